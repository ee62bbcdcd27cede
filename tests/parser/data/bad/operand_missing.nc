; [value-missing] 2:8: error: a number is missing before ']' (hint: write a number, a parameter (#1), a function (SIN[30]) or an expression in [ ])
G0 X[1+]
