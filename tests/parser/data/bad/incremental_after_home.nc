; [position-unknown] 5:1: error: Z1 is incremental, but Z is not known since G28 on line 3 (hint: program Z once in absolute coordinates (G90) first)
G0 X5 Z5
G28 Z5
G91 X1
Z1
