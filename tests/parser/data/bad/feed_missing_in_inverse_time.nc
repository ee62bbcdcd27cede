; [feed-missing] 3:1: error: G1 without F in G93 (hint: in G93 each cutting block needs its own F, the inverse of its minutes)
G93 G1 X5 F2
X6
