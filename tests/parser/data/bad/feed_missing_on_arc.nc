; [feed-missing] 3:1: error: G2 without a feed rate (hint: give F on this block or before, above zero)
G0 X0 Y0
G2 X10 I5
