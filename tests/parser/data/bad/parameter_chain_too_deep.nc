; [brackets-too-deep] 2:69: error: more than 64 brackets within each other (hint: compute a part of the expression into a parameter first)
G0 X#################################################################1
