; [bracket-missing] 2:13: error: a function needs its argument in [ ] (hint: write for example SIN[30])
G0 XATAN[1]/2
