; [comment-in-comment] 2:13: error: comment inside a comment (hint: use other brackets inside comments)
G0 X1 (tool (flat) 10)
