; [tool-missing] 2:1: error: M6 without a tool (hint: give T on this block or before)
M6
