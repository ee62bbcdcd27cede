; [feed-missing] 2:1: error: G1 without a feed rate (hint: give F on this block or before, above zero)
G1 X5
