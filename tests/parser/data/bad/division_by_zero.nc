; [division-by-zero] 3:7: error: division of 3 by zero (hint: check the divisor before dividing)
#1=4
G0 X[3/[#1-4]]
