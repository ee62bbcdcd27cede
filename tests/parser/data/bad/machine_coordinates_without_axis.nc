; [axes-missing] 2:4: error: G53 names no axis (hint: give the axes to move, for example Z0)
G0 G53
