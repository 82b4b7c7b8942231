" Runs gcheck on a part program and reads its concise output into the quickfix list.
" Usage: :compiler gcheck, then :make %

if exists('current_compiler')
  finish
endif
let current_compiler = 'gcheck'

CompilerSet makeprg=gcheck\ check\ --quiet\ --output-format\ concise
CompilerSet errorformat=%f:%l:%c:\ %trror[%*[^]]]\ %m,%f:%l:%c:\ %tarning[%*[^]]]\ %m,%f:%l:%c:\ %tnfo[%*[^]]]\ %m,%f:%l:%c:\ %tint[%*[^]]]\ %m,%-G%.%#
