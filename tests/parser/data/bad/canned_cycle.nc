; [position-unknown] 2:1: error: the cycle starts at an unknown Z: Z has not been programmed yet (hint: program Z in absolute coordinates (G90) before it)
G81 X1 Y1 Z-5 R2 F100
