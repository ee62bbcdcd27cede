; [bracket-not-closed] 2:5: error: the bracket is not closed (hint: close it with ])
G0 X[1+
