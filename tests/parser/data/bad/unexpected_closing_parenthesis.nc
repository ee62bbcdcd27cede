; [unexpected-character] 2:6: error: unexpected ) (hint: open the comment with ()
G0 X5)
