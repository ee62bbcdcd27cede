; [axes-missing] 2:1: error: G28 names no axis (hint: give the axes to send home, for example G91 G28 Z0)
G28
