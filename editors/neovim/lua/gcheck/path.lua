-- `:GcheckPath`: the page of `gcheck plot` in a browser, which follows the cursor.
--
-- The page comes from a port of this machine alone, behind an address that works once: the browser that opens it first gets a cookie, and
-- nothing is given without that cookie. Requests whose `Host` is not this address are refused as well: a web page whose name leads to
-- this machine gets nothing.

local M = {}

local uv = vim.uv or vim.loop

--- Bytes of a request that are read.
local MOST = 8192
--- Milliseconds after the last change until the page is made again.
local QUIET = 400

--- The server, its secrets and what it shows.
local state = nil

--- Random letters: 32 of them have 128 bits.
local function secret()
  return (uv.random(16):gsub(".", function(c)
    return string.format("%02x", c:byte())
  end))
end

local OUTER = [[<!doctype html>
<html lang="en">
<meta charset="utf-8">
<title>gcheck</title>
<style nonce="NONCE">html, body, iframe { margin: 0; border: 0; width: 100%; height: 100%; display: block; overflow: hidden }</style>
<iframe title="Toolpath" src="/page"></iframe>
<script nonce="NONCE">
"use strict";
const frame = document.querySelector("iframe");
let line = "";
const show = () => frame.contentWindow.location.replace(`/page#line=${line}`);
frame.addEventListener("load", () => {
  document.title = `${frame.contentDocument.title}: gcheck`;
  if (line) show();
});
const events = new EventSource("/events");
events.addEventListener("line", (event) => { line = event.data; show(); });
events.addEventListener("page", () => frame.contentWindow.location.reload());
events.addEventListener("end", () => { events.close(); document.title = "ended: gcheck"; });
</script>
</html>
]]

--- Writes an answer and closes the connection, unless it is to stay open.
local function answer(client, status, headers, body, stays)
  local head = {
    "HTTP/1.1 " .. status,
    "Cache-Control: no-store",
    "Referrer-Policy: no-referrer",
    "X-Content-Type-Options: nosniff",
    "Cross-Origin-Resource-Policy: same-origin",
  }
  vim.list_extend(head, headers)
  if not stays then
    head[#head + 1] = "Content-Length: " .. #body
    head[#head + 1] = "Connection: close"
  end
  client:write(table.concat(head, "\r\n") .. "\r\n\r\n" .. body, function()
    if not stays and not client:is_closing() then
      client:close()
    end
  end)
end

local function refuse(client, status)
  answer(client, status, { "Content-Type: text/plain" }, status .. "\n")
end

--- Sends an event to every page that is open.
local function send(event, data)
  for client in pairs(state and state.listeners or {}) do
    if client:is_closing() then
      state.listeners[client] = nil
    else
      client:write(("event: %s\ndata: %s\n\n"):format(event, data))
    end
  end
end

local function serve_outer(client, cookie)
  local nonce = secret()
  local headers = {
    "Content-Type: text/html; charset=utf-8",
    ("Content-Security-Policy: default-src 'none'; script-src 'nonce-%s'; style-src 'nonce-%s'; frame-src 'self'; connect-src 'self'; frame-ancestors 'none'; base-uri 'none'; form-action 'none'"):format(
      nonce,
      nonce
    ),
  }
  if cookie then
    headers[#headers + 1] = ("Set-Cookie: gcheck=%s; HttpOnly; SameSite=Strict; Path=/"):format(cookie)
  end
  answer(client, "200 OK", headers, (OUTER:gsub("NONCE", nonce)))
end

local function serve_page(client)
  local file = io.open(state.file, "rb")
  if not file then
    return refuse(client, "404 Not Found")
  end
  local body = file:read("*a")
  file:close()
  answer(client, "200 OK", { "Content-Type: text/html; charset=utf-8", "Content-Security-Policy: frame-ancestors 'self'" }, body)
end

local function serve_events(client)
  answer(client, "200 OK", { "Content-Type: text/event-stream" }, "", true)
  state.listeners[client] = true
  if state.line then
    client:write(("event: line\ndata: %d\n\n"):format(state.line))
  end
end

local function route(client, head)
  local method, path = head:match("^(%u+) (%S+) HTTP/1%.[01]\r\n")
  local fields = {}
  for name, value in head:gmatch("\r\n([%w-]+):[ \t]*([^\r\n]*)") do
    fields[name:lower()] = value
  end
  if method ~= "GET" then
    return refuse(client, "405 Method Not Allowed")
  end
  if fields.host ~= state.host then
    return refuse(client, "403 Forbidden")
  end
  local cookie
  for part in (fields.cookie or ""):gmatch("[^;%s]+") do
    cookie = cookie or part:match("^gcheck=(%x+)$")
  end
  local is_known = cookie ~= nil and cookie == state.cookie
  if path == "/" .. (state.token or "") and state.token then
    -- From here on it is worth nothing.
    state.token = nil
    state.used = path
    state.cookie = secret()
    return serve_outer(client, state.cookie)
  end
  if not is_known then
    return refuse(client, "403 Forbidden")
  end
  if path == state.used then
    return serve_outer(client)
  elseif path == "/page" then
    return serve_page(client)
  elseif path == "/events" then
    return serve_events(client)
  end
  return refuse(client, "404 Not Found")
end

local function accept(server)
  local client = uv.new_tcp()
  server:accept(client)
  local head = ""
  client:read_start(function(error, chunk)
    if error or not chunk then
      if state then
        state.listeners[client] = nil
      end
      if not client:is_closing() then
        client:close()
      end
      return
    end
    head = head .. chunk
    if head:find("\r\n\r\n", 1, true) then
      local whole = head
      head = ""
      if state and not state.listeners[client] then
        route(client, whole)
      end
    elseif #head > MOST then
      refuse(client, "431 Request Header Fields Too Large")
    end
  end)
end

--- Makes the page of the buffer as it is, saved or not, and calls `done` with what the program said against it, if anything.
local function make_page(buffer, done)
  local mine = state
  mine.asked = mine.asked + 1
  local number = mine.asked
  local new = mine.folder .. "/new-" .. number .. ".html"
  local name = vim.api.nvim_buf_get_name(buffer)
  local title = vim.fn.fnamemodify(name, ":t")
  local command = { require("gcheck").command()[1], "plot", "--quiet", "--stdin-filename", title, "-", "-o", new }
  local said = {}
  local is_started, job = pcall(vim.fn.jobstart, command, {
    cwd = vim.fn.fnamemodify(name, ":h"),
    on_stderr = function(_, lines)
      vim.list_extend(said, lines)
    end,
    on_exit = function()
      -- The session was ended, or another one was begun: its folder is gone.
      if state ~= mine then
        return
      end
      -- A later text is on its way.
      if number ~= mine.asked then
        uv.fs_unlink(new)
        return
      end
      -- The exit code tells about the run, so only the file shows whether the page was made.
      local is_made = uv.fs_stat(new) ~= nil
      if is_made then
        uv.fs_rename(new, mine.file)
      end
      done(not is_made and table.concat(said, "\n") or nil)
    end,
  })
  if not is_started then
    return done(tostring(job))
  end
  vim.fn.chansend(job, vim.api.nvim_buf_get_lines(buffer, 0, -1, false))
  vim.fn.chansend(job, "\n")
  vim.fn.chanclose(job, "stdin")
end

local function warn(message)
  vim.api.nvim_echo({ { "gcheck: " .. message, "WarningMsg" } }, true, {})
end

--- Opens an address as the system does.
local function open_browser(address)
  local own = require("gcheck").options.open
  if own then
    return own(address)
  end
  if vim.ui.open then
    return vim.ui.open(address)
  end
  local opener = vim.fn.has("mac") == 1 and "open" or vim.fn.has("win32") == 1 and "explorer" or "xdg-open"
  vim.fn.jobstart({ opener, address }, { detach = true })
end

--- Tells the pages the line of the cursor.
local function follow()
  if state and vim.api.nvim_get_current_buf() == state.buffer then
    local line = vim.api.nvim_win_get_cursor(0)[1]
    if line ~= state.line then
      state.line = line
      send("line", tostring(line))
    end
  end
end

--- Makes the page again when the text has been quiet for a moment.
local function renew()
  state.timer:stop()
  state.timer:start(
    QUIET,
    0,
    vim.schedule_wrap(function()
      if not state then
        return
      end
      make_page(state.buffer, function(problem)
        if state and not problem then
          send("page", "new")
        end
      end)
    end)
  )
end

--- Ends the server; pages that are open say so.
function M.stop()
  if not state then
    return
  end
  send("end", "")
  local old = state
  state = nil
  pcall(vim.api.nvim_del_augroup_by_id, old.group)
  old.timer:stop()
  old.timer:close()
  old.server:close()
  vim.defer_fn(function()
    for client in pairs(old.listeners) do
      if not client:is_closing() then
        client:close()
      end
    end
  end, 50)
  vim.fn.delete(old.folder, "rf")
end

--- Shows the toolpath of the buffer that is shown in a browser, and lets it follow the cursor.
function M.show()
  if vim.bo.filetype ~= "gcode" then
    return warn("this buffer is not a part program")
  end
  M.stop()
  local server = uv.new_tcp()
  -- No other machine can come here.
  assert(server:bind("127.0.0.1", 0))
  local folder = vim.fn.tempname()
  vim.fn.mkdir(folder, "p", tonumber("700", 8))
  local port = server:getsockname().port
  state = {
    server = server,
    host = "127.0.0.1:" .. port,
    token = secret(),
    buffer = vim.api.nvim_get_current_buf(),
    folder = folder,
    file = folder .. "/page.html",
    --- How many times the page was asked for.
    asked = 0,
    listeners = {},
    timer = uv.new_timer(),
    group = vim.api.nvim_create_augroup("gcheck_path", { clear = true }),
  }
  server:listen(16, function()
    if state then
      accept(server)
    end
  end)
  local on = function(events, run)
    vim.api.nvim_create_autocmd(events, { group = state.group, buffer = state.buffer, callback = run })
  end
  on({ "CursorMoved", "CursorMovedI" }, follow)
  on({ "TextChanged", "InsertLeave", "BufWritePost" }, renew)
  on({ "BufWipeout" }, M.stop)
  vim.api.nvim_create_autocmd("VimLeavePre", { group = state.group, callback = M.stop })
  follow()
  make_page(state.buffer, function(problem)
    if not state then
      return
    end
    if problem then
      M.stop()
      return warn(problem)
    end
    open_browser("http://" .. state.host .. "/" .. state.token)
  end)
end

return M
