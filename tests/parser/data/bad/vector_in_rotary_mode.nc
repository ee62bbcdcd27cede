; [word-unused] 3:10: error: I1 in G43.4, where rotary words turn the tool (hint: give the direction by rotary words, or switch tool vectors on with G43.5)
G43.4 H1
G1 X0 Y0 I1 J0 K1 F100
