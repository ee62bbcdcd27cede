; [number-too-large] 2:5: error: the result is too large for a number (hint: check the operands)
G0 XEXP[1000]
