; [out-of-range] 2:1: error: T-1 is out of range (hint: T goes from 0 to 99999999)
T-1
