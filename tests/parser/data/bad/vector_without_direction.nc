; [vector-zero] 3:13: error: the tool vector has no direction (hint: give I J K a length above zero; it points from the tip to the spindle)
G43.5 H1
G0 X0 Y0 Z0 I0 J0 K0
