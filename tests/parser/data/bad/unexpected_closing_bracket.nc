; [unexpected-character] 2:6: error: unexpected ] (hint: open the expression with [)
G0 X5]
