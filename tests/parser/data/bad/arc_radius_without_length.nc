; [arc-full-by-radius] 3:10: error: an arc with R ends at its start, which leaves its centre open (hint: give the centre of a full circle by I and J)
G0 X0 Y0
G2 X0 Y0 R5 F100
