; [rotary-with-vector] 3:7: error: A5 in G43.5, where tool vectors turn the axes (hint: give the direction by I J K, or use G43.4)
G43.5 H1
G0 X0 A5
