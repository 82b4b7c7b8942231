-- For `vim.lsp.enable("gcheck")` of Neovim 0.11 without the rest of this plugin.
return {
  cmd = { vim.env.GCHECK_PATH or "gcheck", "lsp" },
  filetypes = { "gcode" },
  root_markers = { "gcheck.toml", ".gcheck.toml", ".git" },
}
