; [division-by-zero] 2:6: error: division of 1 by zero (hint: check the divisor before dividing)
#1=[1/0]
