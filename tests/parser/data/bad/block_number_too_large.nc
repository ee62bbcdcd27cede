; [number-too-large] 2:2: error: the number is too large (hint: N and O numbers have up to 8 digits)
N99999999999 G0 X5
