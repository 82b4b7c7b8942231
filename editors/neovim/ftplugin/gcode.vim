" A comment stands in parentheses on every control.
if exists("b:did_ftplugin")
  finish
endif
let b:did_ftplugin = 1
setlocal commentstring=(%s) iskeyword+=#,.
let b:undo_ftplugin = "setlocal commentstring< iskeyword<"
