; [position-unknown] 5:14: error: A5 is incremental, but A is not known since the tool vector on line 4 (hint: program A once in absolute coordinates (G90) first)
G43.4 H1
G0 X0 Y0 Z0 A0 C0
G43.5 H1 I1 J0 K1
G43.4 H1 G91 A5
