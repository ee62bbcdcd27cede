; [unexpected-character] 2:7: error: unexpected '$' (hint: a block consists of words such as G1 X10, settings such as #1=2, and comments in ( ))
G0 X5 $
