; [feed-missing] 3:2: error: G1 without a feed rate (hint: give F on this block or before, above zero)
G0	X0
	G1	X5 F0
