; 2:1: error: G68 is not simulated (hint: write the positions out, or use G68.2 X Y Z I J K for a tilted plane)
G68 X0 Y0 R30
