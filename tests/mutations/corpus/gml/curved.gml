Creator "networkx"
graph [
  multigraph 1
  node [ id 0 label "stem" x 0.0 y 0 ]
  node [ id 1 label "a &quot;fork&quot;" graphics [ x 200 y 0 w 3 fill "#ffffff" ] ]
  node [ id 2 label "tip" x 300.5 y 1e2 ]
  edge [ source 0 target 1 key 0 radius 5 length 200.0 ]
  edge [ source 0 target 1 key 1 width 8 points 0 points 100 points 200 points 100 ]
  # a vein
  edge [ source 1 target 2 radius 3 length 180 ]
]
