-- Starts the language server for G-code buffers, on Neovim 0.7 and later.
--
-- On 0.11 the server is configured by `vim.lsp.config` and started by `vim.lsp.enable`; on 0.8 to 0.10 by
-- `vim.lsp.start`; on 0.7, which has neither, by `vim.lsp.start_client` and one client for each root.

local M = {}

--- What is in force; `setup` changes it.
M.options = {
  --- The program, with its arguments.
  cmd = nil,
  --- Settings as the server knows them: control, configPath, run, inlayHints, codeLens, foldRepeats.
  settings = {},
  --- Called with client and buffer when the server is attached.
  on_attach = nil,
  --- Capabilities of a completion plugin, if there is one.
  capabilities = nil,
  --- Called with the address of the toolpath in place of the system's browser.
  open = nil,
}

local markers = { "gcheck.toml", ".gcheck.toml", ".git" }

--- Is a buffer for the server: a program, or the configuration of gcheck?
function M.wants(buffer)
  local name = vim.fn.fnamemodify(vim.api.nvim_buf_get_name(buffer), ":t")
  return vim.bo[buffer].filetype == "gcode" or name == "gcheck.toml" or name == ".gcheck.toml"
end

--- The command that starts the server.
function M.command()
  return M.options.cmd or { vim.env.GCHECK_PATH or "gcheck", "lsp" }
end

--- The nearest folder above a file that holds a configuration or a repository.
function M.root(file)
  local folder = vim.fn.fnamemodify(file, ":p:h")
  local start = folder
  while true do
    for _, marker in ipairs(markers) do
      local path = folder .. "/" .. marker
      if vim.fn.filereadable(path) == 1 or vim.fn.isdirectory(path) == 1 then
        return folder
      end
    end
    local parent = vim.fn.fnamemodify(folder, ":h")
    if parent == folder then
      return start
    end
    folder = parent
  end
end

--- What every way of starting a client needs.
function M.config(root)
  return {
    name = "gcheck",
    cmd = M.command(),
    root_dir = root,
    capabilities = M.options.capabilities,
    settings = { gcheck = M.options.settings },
    -- The server has the settings from its first moment, also in editors that it cannot ask.
    init_options = M.options.settings,
    on_attach = M.options.on_attach,
  }
end

-- Neovim 0.7: clients by root.
local clients = {}

local function start_client(buffer, root)
  local id = clients[root]
  if not id or not vim.lsp.get_client_by_id(id) then
    local config = M.config(root)
    config.workspace_folders = { { uri = vim.uri_from_fname(root), name = root } }
    -- 0.7 keeps only what the server answers to; the default capabilities are those of the editor.
    config.capabilities = config.capabilities or vim.lsp.protocol.make_client_capabilities()
    id = vim.lsp.start_client(config)
    clients[root] = id
  end
  if id then
    vim.lsp.buf_attach_client(buffer, id)
  end
  return id
end

--- Attaches the server to a buffer.
function M.attach(buffer)
  local file = vim.api.nvim_buf_get_name(buffer)
  local root = M.root(file)
  if vim.lsp.start then
    return vim.lsp.start(M.config(root), { bufnr = buffer })
  end
  return start_client(buffer, root)
end

--- Explains a rule or a code in a split window.
function M.explain(subject)
  local words = { M.command()[1], "explain", subject }
  local lines = vim.fn.systemlist(words)
  if vim.v.shell_error ~= 0 then
    vim.api.nvim_echo({ { table.concat(lines, "\n"), "WarningMsg" } }, true, {})
    return
  end
  vim.cmd("new")
  vim.api.nvim_buf_set_lines(0, 0, -1, false, lines)
  vim.bo.buftype, vim.bo.bufhidden, vim.bo.swapfile, vim.bo.filetype = "nofile", "wipe", false, "markdown"
  vim.bo.modifiable = false
end

--- Sets options and starts the server for G-code buffers, those that are open included.
function M.setup(options)
  M.options = vim.tbl_deep_extend("force", M.options, options or {})
  if vim.lsp.config and vim.lsp.enable then
    vim.lsp.config("gcheck", {
      cmd = M.command(),
      filetypes = { "gcode", "toml" },
      root_dir = function(buffer, start)
        if M.wants(buffer) then
          start(M.root(vim.api.nvim_buf_get_name(buffer)))
        end
      end,
      settings = { gcheck = M.options.settings },
      -- The server has the settings from its first moment, also in editors that it cannot ask.
      init_options = M.options.settings,
      capabilities = M.options.capabilities,
      on_attach = M.options.on_attach,
    })
    vim.lsp.enable("gcheck")
    return
  end
  local group = vim.api.nvim_create_augroup("gcheck", { clear = true })
  vim.api.nvim_create_autocmd("FileType", {
    group = group,
    pattern = { "gcode", "toml" },
    callback = function(event)
      if M.wants(event.buf) then
        M.attach(event.buf)
      end
    end,
  })
  for _, buffer in ipairs(vim.api.nvim_list_bufs()) do
    if vim.api.nvim_buf_is_loaded(buffer) and M.wants(buffer) then
      M.attach(buffer)
    end
  end
end

return M
