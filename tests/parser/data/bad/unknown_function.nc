; [bracket-missing] 2:8: error: a function needs its argument in [ ] (hint: write for example SIN[30])
G0 XSINH[1]
