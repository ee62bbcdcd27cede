%
O1 (FREEFORM SURFACE, BALL D12, ROWS 4 MM APART)
(the surface is z = #5 sin[#3 x] cos[#4 y] - 9, touched at x, y by a ball of radius #6)
G21 G90 G17
#3=2.4 #4=2.2 #5=6.5
(roughing, bull nose, 1 mm left)
T1 M6
S6000 M3
G54 G43 H1
#6=7. #7=1 #10=-78. #11=7.
M98 P100 L12
G0 Z60
(finishing, ball)
T2 M6
S9000 M3
G54 G43 H2
#6=6. #7=0 #10=-56. #11=4.
M98 P200 L29
G0 Z60
M30
O100 (one level row of roughing)
G0 X-90 Y#10
G0 Z0
G1 Z-1.5 F1500
X90
G0 Z10
#10=#10+#11
M99
O200 (one row of finishing)
G0 X-76 Y#10 Z8
#1=-72.
M98 P300 L73
G0 Z8
#10=#10+#11
M99
O300 (one point: touch at #1, #10)
#20=#3*#5*COS[#3*#1]*COS[#4*#10]*0.0174532925199433
#21=0-#4*#5*SIN[#3*#1]*SIN[#4*#10]*0.0174532925199433
#22=SQRT[1+#20*#20+#21*#21]
#23=#5*SIN[#3*#1]*COS[#4*#10]-9.
G1 X[#1-#6*#20/#22] Y[#10-#6*#21/#22] Z[#23+#6/#22-#6] F2500
#1=#1+2.
M99
%
