; [comment-not-closed] 2:7: error: the comment is not closed (hint: close it with ) on the same line)
G0 X1 (to the start
