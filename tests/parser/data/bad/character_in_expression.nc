; [unexpected-character] 2:8: error: unexpected '$' in an expression (hint: operators are + - * / ** MOD AND OR XOR and one EQ, NE, GT, GE, LT or LE; close the expression with ])
G0 X[1 $ 2]
