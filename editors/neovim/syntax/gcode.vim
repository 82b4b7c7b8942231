" What the lexer can say; the server's semantic tokens say the rest.
if exists("b:current_syntax")
  finish
endif
syntax case ignore
syntax region gcodeComment start=/(/ end=/)\|$/ oneline
syntax match gcodeComment /;.*$/
syntax match gcodeTape /^\s*%.*$/
syntax match gcodeProgram /^\s*[O:]\s*\(\d\+\|<[^>]*>\)/
syntax match gcodeLabel /\<N\s*\d\+/
syntax match gcodeCode /\<[GM]\s*\d\+\(\.\d\+\)\?/
" After the codes: of two matches at one place the later one wins.
syntax match gcodeRapid /\<G\s*0*0\(\.\|\d\)\@!/
syntax match gcodeFeed /\<G\s*0*1\(\.\|\d\)\@!/
syntax match gcodeArc /\<G\s*0*[23]\(\.\|\d\)\@!/
syntax match gcodeTool /\<[ST]\s*\d\+/
syntax match gcodeVariable /#\+\d\+\|#\s*<[^>]*>/
syntax keyword gcodeFlow IF THEN ELSE ELSEIF ENDIF WHILE ENDWHILE DO REPEAT ENDREPEAT CALL SUB ENDSUB RETURN BREAK CONTINUE GOTO
syntax match gcodeFlow /\<\(DO\|END\|GOTO\)\d\+/
syntax keyword gcodeFunction SIN COS TAN ASIN ACOS ATAN SQRT ABS ROUND FIX FUP LN EXP EXISTS
syntax keyword gcodeOperator EQ NE GT GE LT LE AND OR XOR MOD
highlight default link gcodeComment Comment
highlight default link gcodeTape PreProc
highlight default link gcodeProgram Function
highlight default link gcodeLabel Label
highlight default link gcodeRapid WarningMsg
highlight default link gcodeFeed Statement
highlight default link gcodeArc Special
highlight default link gcodeCode Keyword
highlight default link gcodeTool Type
highlight default link gcodeVariable Identifier
highlight default link gcodeFlow Conditional
highlight default link gcodeFunction Function
highlight default link gcodeOperator Operator
" The server's kinds of tokens; names with `@` exist from 0.9 on.
if has("nvim-0.9")
  highlight default link @lsp.type.rapid.gcode gcodeRapid
  highlight default link @lsp.type.feed.gcode gcodeFeed
  highlight default link @lsp.type.arc.gcode gcodeArc
  highlight default link @lsp.type.cycle.gcode gcodeArc
  highlight default link @lsp.type.modal.gcode gcodeCode
  highlight default link @lsp.type.code.gcode gcodeCode
  highlight default link @lsp.type.coordinate.gcode Number
  highlight default link @lsp.type.word.gcode Constant
  highlight default link @lsp.type.tool.gcode gcodeTool
  highlight default link @lsp.type.label.gcode gcodeLabel
  highlight default link @lsp.type.program.gcode gcodeProgram
endif
let b:current_syntax = "gcode"
