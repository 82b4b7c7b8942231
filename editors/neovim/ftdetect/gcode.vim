" Part programs by the names that gcheck reads from folders; names that other files have too, only where nothing else is known.
autocmd BufNewFile,BufRead *.nc,*.NC,*.ngc,*.NGC,*.cnc,*.CNC,*.tap,*.TAP,*.eia,*.EIA,*.ncf,*.NCF,*.gcode,*.GCODE,*.mpf,*.MPF,*.spf,*.SPF set filetype=gcode
autocmd BufNewFile,BufRead *.iso,*.ISO,*.din,*.DIN,*.prg,*.PRG,*.min,*.MIN setfiletype gcode
autocmd BufNewFile,BufRead [oO][0-9][0-9][0-9][0-9],[oO][0-9][0-9][0-9][0-9][0-9] set filetype=gcode
