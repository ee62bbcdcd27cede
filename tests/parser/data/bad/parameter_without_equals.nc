; [keyword-missing] 2:1: error: a parameter setting has no = (hint: write #1=value to set a parameter, X#1 to use one)
#5 G0 X1
