-- Starts gcheck for G-code buffers, unless `vim.g.gcheck_autostart` is false; options go to `require("gcheck").setup()`.

if vim.g.loaded_gcheck then
  return
end
vim.g.loaded_gcheck = true

vim.api.nvim_create_user_command("GcheckExplain", function(arguments)
  require("gcheck").explain(arguments.args)
end, { nargs = 1, desc = "Explain a rule or a code" })

vim.api.nvim_create_user_command("GcheckPath", function(arguments)
  local path = require("gcheck.path")
  if arguments.bang then
    path.stop()
  else
    path.show()
  end
end, { bang = true, desc = "Show the toolpath in a browser, which follows the cursor; with ! end that" })

if vim.g.gcheck_autostart ~= false then
  require("gcheck").setup(vim.g.gcheck_options)
end
