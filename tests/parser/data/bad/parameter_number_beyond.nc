; [parameter-number] 2:1: error: parameter #100000 does not exist (hint: parameters are #1 to #99999)
#100000=1
