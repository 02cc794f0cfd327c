// Bar of 30 mm x 30 mm x 57.5 mm in 30 layers, 1 mm thick in its middle, which is 1 % narrower on two of its sides.
// Gmsh: gmsh -3 -format msh22 waisted_bar.geo
side = 0.03; narrow = 0.99 * side; height = 0.0575; fine = 0.01;
z[] = {0, height / 2 - fine, height / 2, height / 2 + fine, height};
layers[] = {5, 10, 10, 5};
For i In {0:4}
  s = side - (side - narrow) * (1 - Fabs(z[i] - height / 2) / (height / 2));
  Point(4 * i + 1) = {0, 0, z[i]}; Point(4 * i + 2) = {s, 0, z[i]};
  Point(4 * i + 3) = {s, s, z[i]}; Point(4 * i + 4) = {0, s, z[i]};
  For k In {1:4}
    Line(4 * i + k) = {4 * i + k, 4 * i + (k % 4) + 1};
    Transfinite Curve{4 * i + k} = 2;
  EndFor
  Curve Loop(100 + i) = {4 * i + 1, 4 * i + 2, 4 * i + 3, 4 * i + 4};
  Plane Surface(100 + i) = {100 + i};
  Transfinite Surface{100 + i}; Recombine Surface{100 + i};
EndFor
For i In {0:3}
  For k In {1:4}
    Line(40 + 4 * i + k) = {4 * i + k, 4 * (i + 1) + k};
    Transfinite Curve{40 + 4 * i + k} = layers[i] + 1;
  EndFor
  For k In {1:4}
    Curve Loop(200 + 4 * i + k) = {4 * i + k, 40 + 4 * i + (k % 4) + 1, -(4 * (i + 1) + k), -(40 + 4 * i + k)};
    Plane Surface(200 + 4 * i + k) = {200 + 4 * i + k};
    Transfinite Surface{200 + 4 * i + k}; Recombine Surface{200 + 4 * i + k};
  EndFor
  Surface Loop(300 + i) = {100 + i, 101 + i, 201 + 4 * i, 202 + 4 * i, 203 + 4 * i, 204 + 4 * i};
  Volume(300 + i) = {300 + i};
  Transfinite Volume{300 + i};
EndFor
Physical Volume("solid", 1) = {300, 301, 302, 303};
