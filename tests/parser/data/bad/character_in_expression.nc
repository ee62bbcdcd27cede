; 2:8: error: unexpected '$' in an expression (hint: operators are + - * / ** MOD; close the expression with ])
G0 X[1 $ 2]
