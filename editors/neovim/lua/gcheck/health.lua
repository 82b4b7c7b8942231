-- `:checkhealth gcheck`: is the program there, does it answer, is it attached?

local M = {}

local health = vim.health or require("health")
local start = health.start or health.report_start
local ok = health.ok or health.report_ok
local warn = health.warn or health.report_warn
local bad = health.error or health.report_error

function M.check()
  start("gcheck")
  local gcheck = require("gcheck")
  local program = gcheck.command()[1]
  if vim.fn.executable(program) ~= 1 then
    bad(("`%s` is not on the search path: install gcheck, set GCHECK_PATH, or give `cmd` to setup()"):format(program))
    return
  end
  local version = vim.fn.system({ program, "--version" })
  if vim.v.shell_error == 0 then
    ok(("`%s` is %s"):format(program, vim.trim(version)))
  else
    bad(("`%s --version` fails: %s"):format(program, vim.trim(version)))
  end
  if vim.fn.has("nvim-0.7") ~= 1 then
    bad("Neovim 0.7 or later is needed")
  end
  local get = vim.lsp.get_clients or vim.lsp.get_active_clients
  local count = 0
  for _, client in pairs(get()) do
    if client.name == "gcheck" then
      count = count + 1
    end
  end
  if count > 0 then
    ok(("%d server(s) running"):format(count))
  else
    warn("no server is running: open a part program, or set its filetype to `gcode`")
  end
end

return M
