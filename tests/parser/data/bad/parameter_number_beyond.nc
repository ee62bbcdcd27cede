; [parameter-number] 2:1: error: parameter #1000000 does not exist (hint: parameters are #1 to #999999)
#1000000=1
