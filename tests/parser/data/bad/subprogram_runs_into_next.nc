; [subprogram-end-missing] 4:1: error: subprogram O2000 has no M99 (hint: end the subprogram with M99)
M98 P2000
M30
O2000
G0 X5
O3000
M99
