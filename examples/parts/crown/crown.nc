%
O5 (CROWNED BLOCK: LENS CUTTER NORMAL TO THE CROWN, BARREL ALONG THE WALLS)
(crown: cylinder of 150 mm about Y, its top at Z0; walls X40, Y35 with corners of 12 mm)
G21 G90 G17
G53 G0 Z500.
G53 G0 B0. C0.
(walls, 0.2 mm left)
T1 M6
S4000 M3
G54 G43 H1
#5=8.2
G0 X-70 Y0 Z10
#6=-10.
M98 P100
#6=-20.
M98 P100
G0 Z60
(walls, barrel in rows of 4 mm)
T2 M6
S8000 M3
G54 G43 H2
#5=6.
G0 X-70 Y0 Z10
#6=0.
M98 P110 L6
G0 Z60
(crown, lens cutter around the cylinder in rows of 3 mm)
G49
G53 G0 Z500.
T3 M6
S5000 M3
G54 G43.5 H3
G0 X-90 Y-40 Z60 I0 J0 K1
#1=-42.
M98 P200 L29
G49
G53 G0 Z500.
M30
O100 (round the walls at depth #6, tool #5 off them)
G0 X-70 Y0
G0 Z#6
M98 P130
M99
O110 (one row of the barrel)
M98 P100
#6=#6-4.
M99
O130 (round the walls)
G1 X[-40-#5] F1500
G1 Y23
G2 X-28 Y[35+#5] I[12+#5] J0
G1 X28
G2 X[40+#5] Y23 I0 J[-12-#5]
G1 Y-23
G2 X28 Y[-35-#5] I[-12-#5] J0
G1 X-28
G2 X[-40-#5] Y-23 I0 J[12+#5]
G1 Y1
G0 X-70
M99
O200 (one row over the crown)
#2=-22.
G0 X[160*SIN[#2]] Y#1 Z[160*COS[#2]-150] I[SIN[#2]] J0 K[COS[#2]]
M98 P210 L45
G0 X[170*SIN[#2]] Y#1 Z[170*COS[#2]-150] I[SIN[#2]] J0 K[COS[#2]]
G0 X0 Y#1 Z40 I0 J0 K1
G0 X[170*SIN[-22]] Y#1 Z[170*COS[-22]-150] I[SIN[-22]] J0 K[COS[-22]]
#1=#1+3.
M99
O210 (one point of a row)
G1 X[150*SIN[#2]] Y#1 Z[150*COS[#2]-150] I[SIN[#2]] J0 K[COS[#2]] F1500
#2=#2+1.
M99
%
