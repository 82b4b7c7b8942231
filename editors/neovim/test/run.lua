-- Tests inside Neovim with the real server: `nvim --headless --clean -c 'luafile run.lua'`, from a folder of programs.
--
-- GCHECK_PATH names the program, GCHECK_PLUGIN the folder of this plugin. Works on 0.7.2 as on 0.11.

local folder = vim.fn.getcwd()
vim.opt.runtimepath:prepend(vim.env.GCHECK_PLUGIN)
vim.cmd("filetype plugin on")
vim.cmd("source " .. vim.env.GCHECK_PLUGIN .. "/ftdetect/gcode.vim")
vim.cmd("source " .. vim.env.GCHECK_PLUGIN .. "/plugin/gcheck.lua")

local WAIT = 30000
local failed = 0

local function say(line)
  io.stdout:write(line .. "\n")
end

local function test(name, run)
  local ok, message = xpcall(run, debug.traceback)
  if ok then
    say("ok " .. name)
  else
    failed = failed + 1
    say("FAILED " .. name .. ": " .. tostring(message))
  end
end

local function until_(what, ask)
  local answer
  local met = vim.wait(WAIT, function()
    answer = ask()
    return answer ~= nil and answer ~= false
  end, 20)
  assert(met, "waited in vain for " .. what)
  return answer
end

local function open(name)
  vim.cmd("edit " .. vim.fn.fnameescape(folder .. "/" .. name))
  assert(vim.bo.filetype == "gcode", name .. " is " .. vim.bo.filetype)
end

local function finding(rule)
  for _, diagnostic in ipairs(vim.diagnostic.get(0)) do
    local code = diagnostic.code or (diagnostic.user_data and diagnostic.user_data.lsp and diagnostic.user_data.lsp.code)
    if code == rule then
      return diagnostic
    end
  end
end

local function cursor_on(text)
  for number, line in ipairs(vim.api.nvim_buf_get_lines(0, 0, -1, false)) do
    local at = line:find(text, 1, true)
    if at then
      vim.api.nvim_win_set_cursor(0, { number, at })
      return
    end
  end
  error("the program has no " .. text)
end

local function client()
  local get = vim.lsp.get_clients or vim.lsp.get_active_clients
  for _, found in pairs(get()) do
    if found.name == "gcheck" then
      return found
    end
  end
end

--- Is the server attached to the buffer that is shown?
local function attached()
  local buffer = vim.api.nvim_get_current_buf()
  local get = vim.lsp.get_clients or vim.lsp.get_active_clients
  for _, found in pairs(get()) do
    if found.name == "gcheck" and vim.lsp.buf_is_attached(buffer, found.id) then
      return true
    end
  end
  return false
end

local function ask(method, more)
  until_("the server", attached)
  local running = until_("a client", client)
  local parameters = vim.lsp.util.make_position_params(0, running.offset_encoding)
  parameters = vim.tbl_extend("force", parameters, more or {})
  local answers = vim.lsp.buf_request_sync(0, method, parameters, WAIT)
  for _, answer in pairs(answers or {}) do
    assert(not answer.error and not answer.err, vim.inspect(answer))
    if answer.result then
      return answer.result
    end
  end
end

test("a finding appears", function()
  open("part.nc")
  local found = until_("the finding", function()
    return finding("unknown-code")
  end)
  assert(found.lnum == 5, "on line " .. found.lnum)
  assert(found.source == "gcheck", found.source)
end)

test("hover tells a code and the state", function()
  cursor_on("G43")
  local hover = ask("textDocument/hover")
  assert(hover and hover.contents.value:find("G43", 1, true), vim.inspect(hover))
end)

test("an edit clears a finding and another brings it back", function()
  open("typed.nc")
  until_("a client", client)
  vim.api.nvim_buf_set_lines(0, 4, 5, false, { "G999 X10. Y10. (µ 日本 😀)" })
  until_("the finding", function()
    return finding("unknown-code")
  end)
  vim.api.nvim_buf_set_lines(0, 4, 5, false, { "G00 X10. Y10. (µ 日本 😀) G998" })
  local found = until_("the finding behind the comment", function()
    local found = finding("unknown-code")
    return found and found.col > 20 and found
  end)
  local line = vim.api.nvim_buf_get_lines(0, 4, 5, false)[1]
  assert(line:sub(found.col + 1, found.end_col) == "G998", line:sub(found.col + 1, found.end_col))
  vim.api.nvim_buf_set_lines(0, 4, 5, false, { "G00 X10. Y10." })
  until_("no finding", function()
    return finding("unknown-code") == nil
  end)
end)

test("a fix clears its finding", function()
  open("fixable.nc")
  local found = until_("the finding", function()
    return finding("code-given-twice")
  end)
  local running = client()
  vim.api.nvim_win_set_cursor(0, { found.lnum + 1, found.col })
  local raw = found.user_data and found.user_data.lsp
  local range = {
    start = { line = found.lnum, character = found.col },
    ["end"] = { line = found.end_lnum, character = found.end_col },
  }
  local diagnostic = raw and raw.range and raw
    or { range = range, message = found.message, code = found.code, source = "gcheck", severity = found.severity }
  local actions = ask("textDocument/codeAction", { range = range, context = { diagnostics = { diagnostic } } })
  local fix
  for _, action in ipairs(actions or {}) do
    if action.edit and action.kind == "quickfix" and action.diagnostics then
      fix = fix or action
    end
  end
  assert(fix, "no fix in " .. vim.inspect(actions))
  vim.lsp.util.apply_workspace_edit(fix.edit, running.offset_encoding)
  until_("the finding to go", function()
    return finding("code-given-twice") == nil
  end)
end)

test("a program is renamed across files", function()
  open("main.nc")
  cursor_on("P2000")
  local edit = ask("textDocument/rename", { newName = "2500" })
  assert(edit, "no rename")
  local files = 0
  for _ in pairs(edit.changes or edit.documentChanges or {}) do
    files = files + 1
  end
  assert(files == 2, vim.inspect(edit))
  vim.lsp.util.apply_workspace_edit(edit, client().offset_encoding)
  local text = table.concat(vim.api.nvim_buf_get_lines(0, 0, -1, false), "\n")
  assert(text:find("M98 P2500", 1, true), text)
end)

test("gcheck.toml has hover, completion and findings, and another file in TOML has none", function()
  vim.fn.mkdir(folder .. "/shop", "p")
  vim.fn.writefile({ 'control = "haas-mill"', "[machine]", "max_rpm = 8000", "[tools]", "3 = { length = 80.0 }" }, folder .. "/shop/gcheck.toml")
  vim.fn.writefile({ "x = 1" }, folder .. "/shop/other.toml")
  vim.cmd("edit " .. vim.fn.fnameescape(folder .. "/shop/gcheck.toml"))
  vim.bo.filetype = "toml"
  until_("the server", attached)
  cursor_on("max_rpm")
  local hover = ask("textDocument/hover")
  assert(hover and hover.contents.value:find("Highest spindle speed", 1, true), vim.inspect(hover))
  vim.api.nvim_buf_set_lines(0, 3, 3, false, { 'units = "inches"' })
  local found = until_("the finding", function()
    return vim.diagnostic.get(0)[1]
  end)
  assert(found.lnum == 3, vim.inspect(found))
  vim.api.nvim_buf_set_lines(0, 3, 4, false, { 'units = "i"' })
  vim.api.nvim_win_set_cursor(0, { 4, 10 })
  local list = ask("textDocument/completion")
  assert(list and list.items[1] and list.items[1].label == "inch", vim.inspect(list))
  vim.api.nvim_buf_set_lines(0, 3, 4, false, { 'units = "inch"' })
  until_("no finding", function()
    return #vim.diagnostic.get(0) == 0
  end)
  vim.cmd("write")
  vim.fn.writefile({ "O1", "T3 M6", "M30" }, folder .. "/shop/part.nc")
  open("shop/part.nc")
  until_("the server", attached)
  cursor_on("T3")
  local places = ask("textDocument/definition")
  local place = places and places[1]
  local target = place and (place.targetUri or place.uri)
  assert(target and target:find("gcheck.toml", 1, true), vim.inspect(places))
  assert((place.targetRange or place.range).start.line == 5, vim.inspect(places))
  vim.cmd("edit " .. vim.fn.fnameescape(folder .. "/shop/other.toml"))
  vim.bo.filetype = "toml"
  vim.wait(500)
  assert(not attached(), "the server has nothing to do with other files")
end)

test("rapid moves, cuts, arcs and other codes have their own colours", function()
  vim.cmd("syntax on")
  vim.cmd("new")
  vim.api.nvim_buf_set_lines(0, 0, -1, false, { "G00 X1.", "G1X2.", "G02 X3. I1.", "G10 L2", "G01.5" })
  vim.bo.filetype = "gcode"
  local names = {}
  for line = 1, 5 do
    names[line] = vim.fn.synIDattr(vim.fn.synID(line, 1, 1), "name")
  end
  local expected = { "gcodeRapid", "gcodeFeed", "gcodeArc", "gcodeCode", "gcodeCode" }
  assert(vim.deep_equal(names, expected), vim.inspect(names))
  vim.cmd("bwipeout!")
end)

test("options of the user reach the server: cmd, settings, on_attach, capabilities", function()
  vim.fn.mkdir(folder .. "/options/.git", "p")
  vim.fn.writefile({ "G21 G90 G54", "G00 X1.", "G65 P1", "M2" }, folder .. "/options/part.nc")
  local plugin = require("gcheck")
  local before = vim.deepcopy(plugin.options)
  local met = {}
  local capabilities = vim.lsp.protocol.make_client_capabilities()
  capabilities.textDocument.hover.contentFormat = { "plaintext" }
  plugin.setup({
    cmd = { plugin.command()[1], "--isolated", "lsp" },
    settings = { control = "linuxcnc" },
    on_attach = function(found, buffer)
      met[buffer] = found
    end,
    capabilities = capabilities,
  })
  open("options/part.nc")
  local buffer = vim.api.nvim_get_current_buf()
  local own = until_("on_attach", function()
    return met[buffer]
  end)
  assert(vim.deep_equal(own.config.cmd, { plugin.command()[1], "--isolated", "lsp" }), vim.inspect(own.config.cmd))
  -- The control of the settings has no such code.
  local found = until_("the finding", function()
    return finding("unknown-code")
  end)
  assert(found.lnum == 2, vim.inspect(found))
  cursor_on("G00")
  local hover = ask("textDocument/hover")
  assert(hover.contents.kind == "plaintext", vim.inspect(hover))
  plugin.options = before
  plugin.setup({})
end)

test("GcheckExplain shows a page beside the program", function()
  open("part.nc")
  vim.cmd("GcheckExplain unknown-code")
  local text = table.concat(vim.api.nvim_buf_get_lines(0, 0, -1, false), "\n")
  assert(text:find("unknown-code", 1, true) and #text > 300, text)
  assert(vim.bo.buftype == "nofile" and not vim.bo.modifiable)
  vim.cmd("bwipeout!")
end)

--- The answer of the server of `:GcheckPath`, as text; of events what has come when `enough` says so.
local function get(port, path, fields, enough)
  local uv = vim.uv or vim.loop
  local client = uv.new_tcp()
  local text, is_done = "", false
  client:connect("127.0.0.1", port, function(problem)
    assert(not problem, problem)
    client:read_start(function(_, chunk)
      if chunk then
        text = text .. chunk
      else
        is_done = true
      end
    end)
    local host = fields.host or ("127.0.0.1:" .. port)
    local cookie = fields.cookie and ("Cookie: gcheck=" .. fields.cookie .. "\r\n") or ""
    client:write(("%s %s HTTP/1.1\r\nHost: %s\r\n%s\r\n"):format(fields.method or "GET", path, host, cookie))
  end)
  until_("the answer to " .. path, function()
    return is_done or (enough and enough(text))
  end)
  client:close()
  return text
end

test("GcheckPath serves the page by an address that works once, and follows the cursor", function()
  open("pocket.nc")
  local address
  require("gcheck").options.open = function(given)
    address = given
  end
  vim.cmd("GcheckPath")
  until_("the address", function()
    return address
  end)
  local port, path = address:match("^http://127%.0%.0%.1:(%d+)(/%x+)$")
  assert(port and #path == 33, address)
  port = tonumber(port)
  local function status(...)
    return get(port, ...):match("^HTTP/1.1 (%d+)")
  end
  assert(status("/", {}) == "403", "nothing without the token")
  assert(status("/page", {}) == "403", "the page needs a cookie")
  assert(status("/" .. ("0"):rep(32), {}) == "403", "another token")
  assert(status(path, { host = "gcheck.example" }) == "403", "another name for this machine")
  assert(status(path, { method = "POST" }) == "405", "only reading")
  local outer = get(port, path, {})
  local cookie = outer:match("Set%-Cookie: gcheck=(%x+); HttpOnly; SameSite=Strict")
  assert(outer:find("^HTTP/1.1 200") and cookie, outer)
  assert(status(path, {}) == "403", "the token works once")
  assert(status(path, { cookie = cookie }) == "200", "the page can be loaded again")
  assert(status("/page", { cookie = ("0"):rep(32) }) == "403", "another cookie")
  assert(status("/other", { cookie = cookie }) == "404")
  local page = get(port, "/page", { cookie = cookie })
  assert(page:find("pocket.nc", 1, true) and page:find('"toolpath"', 1, true), page:sub(1, 500))
  cursor_on("G03 I-15.")
  local line = vim.api.nvim_win_get_cursor(0)[1]
  vim.cmd("doautocmd CursorMoved")
  local function has(event, data)
    return function(text)
      return text:find("event: " .. event .. "\ndata: " .. data .. "\n\n", 1, true) ~= nil
    end
  end
  get(port, "/events", { cookie = cookie }, has("line", line))
  -- Moves while the page is open, an edit, and the end.
  local moved, edited = false, false
  get(port, "/events", { cookie = cookie }, function(text)
    if not moved and has("line", line)(text) then
      moved = true
      vim.api.nvim_win_set_cursor(0, { 3, 0 })
      vim.cmd("doautocmd CursorMoved")
    elseif moved and not edited and has("line", 3)(text) then
      edited = true
      vim.api.nvim_buf_set_lines(0, 3, 3, false, { "(edited)" })
      vim.cmd("doautocmd TextChanged")
    end
    return edited and has("page", "new")(text)
  end)
  assert(get(port, "/page", { cookie = cookie }):find("(edited)", 1, true), "the page has the text of the buffer")
  vim.cmd("GcheckPath!")
  local uv = vim.uv or vim.loop
  local refused
  local client = uv.new_tcp()
  client:connect("127.0.0.1", port, function(problem)
    refused = problem or "it answers"
  end)
  until_("the end", function()
    return refused
  end)
  assert(refused:find("REFUSED"), refused)
  vim.cmd("edit!")
  require("gcheck").options.open = nil
end)

if vim.env.GCHECK_FOLLOW then
  test("the page of GcheckPath chooses the line of the cursor in a browser", function()
    open("pocket.nc")
    local said = {}
    require("gcheck").options.open = function(address)
      local command = vim.split(vim.env.GCHECK_FOLLOW, "\n")
      command[#command + 1] = address
      vim.fn.jobstart(command, {
        on_stdout = function(_, lines)
          vim.list_extend(said, lines)
        end,
        on_stderr = function(_, lines)
          vim.list_extend(said, lines)
        end,
      })
    end
    local function shown(text)
      return function()
        for _, line in ipairs(said) do
          if line:find(text, 1, true) then
            return true
          end
        end
      end
    end
    vim.api.nvim_win_set_cursor(0, { 15, 0 })
    vim.cmd("GcheckPath")
    local ok, problem = pcall(function()
      until_("the line in the page", shown("says line 15"))
      cursor_on("G03 I-15.")
      vim.cmd("doautocmd CursorMoved")
      until_("the next line in the page", shown("says line " .. vim.api.nvim_win_get_cursor(0)[1]))
      vim.cmd("GcheckPath!")
      until_("the end of the page", shown("title ended: gcheck"))
    end)
    assert(ok, tostring(problem) .. ": " .. table.concat(said, "; "))
    require("gcheck").options.open = nil
  end)
end

test("the health check passes", function()
  vim.cmd("silent checkhealth gcheck")
  local text = table.concat(vim.api.nvim_buf_get_lines(0, 0, -1, false), "\n")
  assert(text:find("server(s) running", 1, true), text)
end)

say(failed == 0 and "all tests passed" or failed .. " tests failed")
vim.cmd(failed == 0 and "qall!" or "cquit 1")
