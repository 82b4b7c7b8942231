-- Whole programs, typed key by key as people type, with the completion of Neovim that opens by itself: what is in the buffer
-- afterwards is what was typed. `nvim --headless --clean -c 'luafile typing.lua'`, from an empty folder; for 0.11 and later.
--
-- GCHECK_PATH names the program, GCHECK_PLUGIN the folder of this plugin, GCHECK_FIXTURES the programs; GCHECK_TYPING=all types
-- all of them, not some. The keys go to a Neovim of their own, through its queue of input as those of a terminal do.

local folder = vim.fn.getcwd()
local WAIT = 30000
local failed = 0

local function say(line)
  io.stdout:write(line .. "\n")
end

--- Starts a Neovim that waits for keys.
local function start()
  local channel = vim.fn.jobstart({ vim.v.progpath, "--embed", "--headless", "--clean", "-n" }, { rpc = true, cwd = folder })
  local function lua(code, ...)
    return vim.rpcrequest(channel, "nvim_exec_lua", code, { ... })
  end
  lua([[
    vim.opt.runtimepath:prepend(vim.env.GCHECK_PLUGIN)
    vim.cmd("filetype plugin on")
    vim.cmd("source " .. vim.env.GCHECK_PLUGIN .. "/ftdetect/gcode.vim")
    vim.opt.completeopt = { "menuone", "noselect", "popup" }
    vim.g.gcheck_options = {
      on_attach = function(client, buffer)
        vim.lsp.completion.enable(true, client.id, buffer, { autotrigger = true })
      end,
    }
    vim.cmd("source " .. vim.env.GCHECK_PLUGIN .. "/plugin/gcheck.lua")
  ]])
  return channel, lua
end

--- Milliseconds from key to key of somebody who types well; the same in each run, and no two alike.
local seed = 1
local function pause()
  seed = (seed * 48271) % 2147483647
  return 100 + seed % 81
end

--- A character as a key.
local function key(character)
  return character == "<" and "<lt>" or character == "\n" and "<CR>" or character
end

--- Types keys into an empty program; gives its text, and how often a list was open.
local function typed(name, configuration, keys)
  vim.fn.mkdir(folder .. "/" .. vim.fn.fnamemodify(name, ":h"), "p")
  if configuration then
    vim.fn.writefile(configuration, folder .. "/" .. vim.fn.fnamemodify(name, ":h") .. "/gcheck.toml")
  end
  local channel, lua = start()
  lua([[vim.cmd("edit " .. ...)]], name)
  local attached = vim.wait(WAIT, function()
    return lua([[return #vim.lsp.get_clients({ name = "gcheck", bufnr = 0 })]]) > 0
  end, 50)
  assert(attached, "the server does not come")
  local lists = 0
  vim.rpcrequest(channel, "nvim_input", "i")
  for _, one in ipairs(keys) do
    vim.rpcrequest(channel, "nvim_input", one)
    vim.wait(pause())
    lists = lists + vim.rpcrequest(channel, "nvim_call_function", "pumvisible", {})
  end
  vim.rpcrequest(channel, "nvim_input", "<Esc>")
  vim.wait(200)
  local lines = vim.rpcrequest(channel, "nvim_buf_get_lines", 0, 0, -1, false)
  vim.fn.jobstop(channel)
  return table.concat(lines, "\n"), lists
end

local function check(name, wanted, keys, configuration)
  local ok, problem = pcall(function()
    local text, lists = typed(name, configuration, keys)
    local is, should = vim.split(text, "\n"), vim.split(wanted, "\n")
    for number = 1, math.max(#is, #should) do
      local message = ("line %d: typed %s, but there is %s"):format(number, tostring(should[number]), tostring(is[number]))
      assert(is[number] == should[number], message)
    end
    assert(lists > 5, "a list was open " .. lists .. " times: it is to open by itself")
    say(("ok %s is typed, and is there as it was typed; a list was open after %d of %d keys"):format(name, lists, #keys))
  end)
  if not ok then
    failed = failed + 1
    say("FAILED " .. name .. ": " .. tostring(problem))
  end
end

local function keys_of(text)
  local keys = {}
  for character in text:gmatch("[%z\1-\127\194-\244][\128-\191]*") do
    keys[#keys + 1] = key(character)
  end
  return keys
end

--- The keys of a text, with a slip now and then that is put right at once.
local function with_slips(text)
  local keys = {}
  for index, line in ipairs(vim.split(text, "\n")) do
    if index > 1 then
      keys[#keys + 1] = "<CR>"
    end
    vim.list_extend(keys, keys_of(line))
    if index % 3 == 0 then
      -- A wrong key.
      vim.list_extend(keys, { "G", "<BS>", "4", "<BS>" })
    elseif index % 3 == 1 then
      -- Back, and on at the end.
      vim.list_extend(keys, { "<Left>", "<Left>", "<Right>", "<End>" })
    else
      -- A look at the line above.
      vim.list_extend(keys, { "<Up>", "<Down>", "<End>" })
    end
  end
  return keys
end

local CORRECTED = [[
%
O1007 (CORRECTED)
#100=4. (DEPTH)
T1 M06
G00 G90 G54 X0. Y0. S5000 M03
G43 H01 Z25. M08
G98 G83 Z-#100 R2. Q1.5 F150.
X-40.
G80
G00 Z50. 
IF [#100 EQ 4.] GOTO 90
M98 P2000
N90 G28 G91 Z0.
M30
%]]

local SOME = { "haas-mill/sleeve.nc", "haas-lathe/pin.nc" }
local fixtures = vim.env.GCHECK_FIXTURES .. "/clean/"
local programs = SOME
if vim.env.GCHECK_TYPING == "all" then
  programs = {}
  for _, file in ipairs(vim.fn.sort(vim.fn.glob(fixtures .. "*/*", false, true))) do
    if file:match("%.nc$") or file:match("%.ngc$") then
      programs[#programs + 1] = file:sub(#fixtures + 1)
    end
  end
end

check("corrected/main.nc", CORRECTED, with_slips(CORRECTED), { 'control = "haas-mill"' })
for _, name in ipairs(programs) do
  local file = fixtures .. name
  local lines = vim.fn.readfile(file)
  for index, line in ipairs(lines) do
    -- Neovim puts blanks at the start of a line there itself.
    lines[index] = line:gsub("^%s+", "")
  end
  local text = table.concat(lines, "\n")
  check(name, text, keys_of(text), vim.fn.readfile(vim.fn.fnamemodify(file, ":h") .. "/gcheck.toml"))
end
say(failed == 0 and "all tests passed" or failed .. " tests failed")
vim.cmd(failed == 0 and "qall!" or "cquit 1")
