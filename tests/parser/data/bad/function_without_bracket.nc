; [bracket-missing] 2:10: error: a function needs its argument in [ ] (hint: write for example SIN[30])
G0 XSQRT 2
