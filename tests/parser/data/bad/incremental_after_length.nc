; [position-unknown] 5:1: error: Z1 is incremental, but Z is not known since the change of tool length compensation on line 3 (hint: program Z once in absolute coordinates (G90) first)
G0 X5 Z5
G43 H1
G91 X1
Z1
