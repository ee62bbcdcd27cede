; [feed-missing] 4:1: error: G1 without a feed rate (hint: give F on this block or before, above zero)
G93 G1 X5 F2
G94
X6
