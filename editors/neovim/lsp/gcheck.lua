-- For `vim.lsp.enable("gcheck")` of Neovim 0.11 without the rest of this plugin.
return {
  cmd = { vim.env.GCHECK_PATH or "gcheck", "lsp" },
  filetypes = { "gcode", "toml" },
  -- Of files in TOML the configuration of gcheck alone.
  root_dir = function(buffer, start)
    local file = vim.api.nvim_buf_get_name(buffer)
    local name = vim.fs.basename(file)
    if vim.bo[buffer].filetype == "gcode" or name == "gcheck.toml" or name == ".gcheck.toml" then
      start(vim.fs.root(buffer, { "gcheck.toml", ".gcheck.toml", ".git" }) or vim.fs.dirname(file))
    end
  end,
}
