; [value-missing] 2:7: error: Y has no number (hint: give Y a number, a parameter (#1) or an expression in [ ])
G0 X5 Y
