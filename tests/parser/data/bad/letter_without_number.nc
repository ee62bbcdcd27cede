; [value-missing] 2:4: error: X has no number (hint: give X a number, a parameter (#1) or an expression in [ ])
G0 X Y5
