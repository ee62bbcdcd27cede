; [value-missing] 2:1: error: the parameter setting has no value (hint: write #1=2.5 or #1=[#2+1])
#5=
