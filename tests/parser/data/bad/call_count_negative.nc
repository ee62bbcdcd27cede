; [out-of-range] 2:11: error: L-1 is out of range (hint: L goes from 0 to 99999)
M98 P2000 L-1
