; [feed-missing] 6:1: error: G1 without a feed rate (hint: give F on this block or before, above zero)
G0 X0
M98 P2000
M30
O2000
G1 X5 F0
M99
