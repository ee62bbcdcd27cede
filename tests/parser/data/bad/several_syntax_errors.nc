; [value-missing] 4:4: error: X has no number (hint: give X a number, a parameter (#1) or an expression in [ ])
; [bracket-not-closed] 6:5: error: the bracket is not closed (hint: close it with ])
; [comment-not-closed] 7:1: error: the comment is not closed (hint: close it with ) on the same line)
G0 X
G0 X10
G0 Y[
(open
