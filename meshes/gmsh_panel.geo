// L-shaped panel, 0.5 m x 0.5 m with legs of 0.25 m; fine where the crack runs, from the inner corner to the left. Point 7
// makes a node where the load acts. Gmsh: gmsh -2 -format msh22 gmsh_panel.geo
fine = 0.0125; coarse = 0.04;
Point(1) = {0, 0, 0, coarse};      Point(2) = {0.25, 0, 0, coarse};
Point(3) = {0.25, 0.25, 0, fine};  Point(7) = {0.47, 0.25, 0, coarse};
Point(4) = {0.5, 0.25, 0, coarse}; Point(5) = {0.5, 0.5, 0, coarse};
Point(6) = {0, 0.5, 0, coarse};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 7}; Line(7) = {7, 4}; Line(4) = {4, 5}; Line(5) = {5, 6}; Line(6) = {6, 1};
Curve Loop(1) = {1, 2, 3, 7, 4, 5, 6};
Plane Surface(1) = {1};
Field[1] = Box;
Field[1].XMin = 0; Field[1].XMax = 0.26; Field[1].YMin = 0.23; Field[1].YMax = 0.4;
Field[1].VIn = fine; Field[1].VOut = coarse; Field[1].Thickness = 0.08;
Background Field = 1;
Mesh.MeshSizeExtendFromBoundary = 0;
Mesh.Algorithm = 6;
Recombine Surface{1};
Physical Curve("bottom", 1) = {1};
Physical Curve("edge", 2) = {2, 3, 7, 4, 5, 6};
Physical Surface("panel", 11) = {1};
