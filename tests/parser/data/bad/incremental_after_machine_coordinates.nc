; [position-unknown] 4:5: error: Z1 is incremental, but Z is not known since the move in machine coordinates (G53) on line 3 (hint: program Z once in absolute coordinates (G90) first)
G0 Z5
G53 Z0
G91 Z1
