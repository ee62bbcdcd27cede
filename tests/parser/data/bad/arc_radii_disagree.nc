; [arc-radius] 3:13: error: the start of the arc is 5 mm from the centre, its end 5.5 mm: 0.5 mm apart (hint: allowed are 0.01 mm, or 0.1 % of the radius up to 0.5 mm; correct I and J or the end)
G0 X0 Y0
G3 X10.5 Y0 I5 J0 F100
