# What all figures share: how tables are read, colours that the colour-blind tell apart (Okabe and Ito) and a line type a model.
set encoding utf8
set minussign
set datafile separator comma
set datafile columnheaders

models = "ward ward-duer ward-neumann gmd"
titles = "Ward Ward–Dür Ward–Neumann new"
set linetype 1 linecolor rgb "#E69F00" linewidth 2 dashtype (14, 5)
set linetype 2 linecolor rgb "#D55E00" linewidth 2 dashtype (5, 4)
set linetype 3 linecolor rgb "#009E73" linewidth 2 dashtype (14, 4, 2, 4)
set linetype 4 linecolor rgb "#0072B2" linewidth 2.5 dashtype solid
set linetype 5 linecolor rgb "#000000" linewidth 2 dashtype (2, 4)

faint = "#C8C8C8"
set border linecolor rgb "#404040"
set grid linetype 1 linecolor rgb faint linewidth 0.7 dashtype solid
set key noautotitle
