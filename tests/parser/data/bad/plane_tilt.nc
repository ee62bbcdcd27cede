; 2:1: error: G68.2 is not simulated (hint: write the positions out, or use G43.4 with tool vectors)
G68.2 X0 Y0 Z0 I30
