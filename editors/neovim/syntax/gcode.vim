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
syntax match gcodeMotion /\<G\s*0*[0-3]\>/
syntax match gcodeCode /\<[GM]\s*\d\+\(\.\d\+\)\?/
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
highlight default link gcodeMotion Statement
highlight default link gcodeCode Keyword
highlight default link gcodeTool Type
highlight default link gcodeVariable Identifier
highlight default link gcodeFlow Conditional
highlight default link gcodeFunction Function
highlight default link gcodeOperator Operator
let b:current_syntax = "gcode"
