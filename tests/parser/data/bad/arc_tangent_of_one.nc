; 2:12: error: ATAN needs two values (hint: write ATAN[y]/[x] or ATAN[y,x])
G0 XATAN[1]
