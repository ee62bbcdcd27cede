; [unexpected-character] 2:3: error: unexpected 'P' (hint: a block consists of words such as G1 X10, settings such as #1=2, and comments in ( ))
% PROGRAM
