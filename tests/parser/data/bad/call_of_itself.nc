; [recursion] 3:5: error: more than 32 subprograms within each other (hint: does O1000 call itself?)
O1000
M98 P1000
M30
