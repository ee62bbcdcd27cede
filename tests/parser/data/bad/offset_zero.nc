; [out-of-range] 2:5: error: H0 is out of range (hint: H goes from 1 to 9999)
G43 H0
