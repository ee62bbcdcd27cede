; [rotary-with-vector] 3:7: error: A5 and a tool vector in one block (hint: give the direction by I J K or by rotary words, not both)
G43.4 H1
G0 X0 A5 K1
