; [bracket-not-closed] 2:8: error: the bracket is not closed (hint: close it with ])
G0 XSIN[30
