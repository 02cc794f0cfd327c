// Bar of 1 m x 0.05 m in 20 squares, one of which is weak. Gmsh: gmsh -2 -format msh22 snap_back_bar.geo
length = 1; height = 0.05; weak_from = 0.5; weak_to = 0.55;
Point(1) = {0, 0, 0};          Point(5) = {0, height, 0};
Point(2) = {weak_from, 0, 0};  Point(6) = {weak_from, height, 0};
Point(3) = {weak_to, 0, 0};    Point(7) = {weak_to, height, 0};
Point(4) = {length, 0, 0};     Point(8) = {length, height, 0};
For i In {1:3}
  Line(i) = {i, i + 1};
  Line(10 + i) = {i + 4, i + 5};
EndFor
For i In {1:4}
  Line(20 + i) = {i, i + 4};
EndFor
For i In {1:3}
  Curve Loop(i) = {i, 20 + i + 1, -(10 + i), -(20 + i)};
  Plane Surface(i) = {i};
EndFor
Transfinite Curve{1, 11} = 11;
Transfinite Curve{2, 12} = 2;
Transfinite Curve{3, 13} = 10;
Transfinite Curve{21, 22, 23, 24} = 2;
Transfinite Surface{1, 2, 3};
Recombine Surface{1, 2, 3};
Physical Curve("left", 1) = {21};
Physical Curve("right", 2) = {24};
Physical Surface("bar", 11) = {1, 3};
Physical Surface("weak", 12) = {2};
