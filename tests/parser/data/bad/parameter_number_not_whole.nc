; [parameter-number] 2:5: error: parameter #1.5 is not a whole number (hint: use ROUND, FIX or FUP on the computed number)
G0 X#[1.5]
