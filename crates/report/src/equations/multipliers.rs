//! Section VIII, solution 2: eqs. (xi)-(xxvi).

equations! {
    "(xi)" "The row of [B] of the joint O, along X, at ψ = 0, θ = π/2; all other entries are zero."
        r"b_{1,1} = 1, \quad b_{1,5} = \frac{l}{2}\cos\varphi_1";
    "(xii)" "The row of [B] of the joint O, along Y, at ψ = 0, θ = π/2; all other entries are zero."
        r"b_{2,2} = 1, \quad b_{2,4} = -\frac{l}{2}\cos\varphi_1, \quad b_{2,6} = -\frac{l}{2}\cos\varphi_1";
    "(xiii)" "The row of [B] of the joint O, in height, at ψ = 0, θ = π/2; all other entries are zero."
        r"b_{3,3} = 1, \quad b_{3,4} = -\frac{l}{2}\sin\varphi_1, \quad b_{3,6} = -\frac{l}{2}\sin\varphi_1";
    "(xiv)" "The row of [B] of the joint A, along X, at ψ = 0, θ = π/2; all other entries are zero."
        r"b_{4,1} = 1, \quad b_{4,5} = -\frac{l}{2}\cos\varphi_1, \quad b_{4,7} = -1, \quad b_{4,11} = -\frac{l}{2}\cos\varphi_2";
    "(xv)" "The row of [B] of the joint A, along Y, at ψ = 0, θ = π/2; all other entries are zero."
        r"b_{5,2} = 1, \quad b_{5,4} = \frac{l}{2}\cos\varphi_1, \quad b_{5,6} = \frac{l}{2}\cos\varphi_1, \quad b_{5,8} = -1, \quad b_{5,10} = \frac{l}{2}\cos\varphi_2, \quad b_{5,12} = \frac{l}{2}\cos\varphi_2";
    "(xvi)" "The row of [B] of the joint A, in height, at ψ = 0, θ = π/2; all other entries are zero."
        r"b_{6,3} = 1, \quad b_{6,4} = \frac{l}{2}\sin\varphi_1, \quad b_{6,6} = \frac{l}{2}\sin\varphi_1, \quad b_{6,9} = -1, \quad b_{6,10} = \frac{l}{2}\sin\varphi_2, \quad b_{6,12} = \frac{l}{2}\sin\varphi_2";
    "(xvii)" "The row of [B] of the joint B, along X, at ψ = 0, θ = π/2; all other entries are zero."
        r"b_{7,7} = 1, \quad b_{7,11} = -\frac{l}{2}\cos\varphi_2, \quad b_{7,13} = -1, \quad b_{7,17} = -\frac{l}{2}\cos\varphi_3";
    "(xviii)" "The row of [B] of the joint B, along Y, at ψ = 0, θ = π/2; all other entries are zero."
        r"b_{8,8} = 1, \quad b_{8,10} = \frac{l}{2}\cos\varphi_2, \quad b_{8,12} = \frac{l}{2}\cos\varphi_2, \quad b_{8,14} = -1, \quad b_{8,16} = \frac{l}{2}\cos\varphi_3, \quad b_{8,18} = \frac{l}{2}\cos\varphi_3";
    "(xix)" "The row of [B] of the joint B, in height, at ψ = 0, θ = π/2; all other entries are zero."
        r"b_{9,9} = 1, \quad b_{9,10} = \frac{l}{2}\sin\varphi_2, \quad b_{9,12} = \frac{l}{2}\sin\varphi_2, \quad b_{9,15} = -1, \quad b_{9,16} = \frac{l}{2}\sin\varphi_3, \quad b_{9,18} = \frac{l}{2}\sin\varphi_3";
    "(xx)" "The row of [B] of the joint D, along X, at ψ = 0, θ = π/2; all other entries are zero. They are those of bar 3, as the corrected (18)-(20) give them."
        r"b_{10,13} = 1, \quad b_{10,17} = -\frac{l}{2}\cos\varphi_3";
    "(xxi)" "The row of [B] of the joint D, along Y, at ψ = 0, θ = π/2; all other entries are zero. They are those of bar 3, as the corrected (18)-(20) give them."
        r"b_{11,14} = 1, \quad b_{11,16} = \frac{l}{2}\cos\varphi_3, \quad b_{11,18} = \frac{l}{2}\cos\varphi_3";
    "(xxii)" "The row of [B] of the joint D, in height, at ψ = 0, θ = π/2; all other entries are zero. They are those of bar 3, as the corrected (18)-(20) give them."
        r"b_{12,15} = 1, \quad b_{12,16} = \frac{l}{2}\sin\varphi_3, \quad b_{12,18} = \frac{l}{2}\sin\varphi_3";
    "(xxiii)" "The 18 equations of (40), written out: for each bar three balances of force and three of moment. The row of θ₁ lost a term."
        r"\begin{aligned} -\lambda_1 - \lambda_4 &= 0, & -\lambda_2 - \lambda_5 &= 0, & -\lambda_3 - \lambda_6 &= -mg, \\ -b_{2,4}\lambda_2 - b_{3,4}\lambda_3 - b_{5,4}\lambda_5 - b_{6,4}\lambda_6 &= 0, & \wrong{-b_{4,5}\lambda_4} &= 0, & -b_{2,6}\lambda_2 - b_{3,6}\lambda_3 - b_{5,6}\lambda_5 - b_{6,6}\lambda_6 &= 0, \\ \lambda_4 - \lambda_7 &= 0, & \lambda_5 - \lambda_8 &= 0, & \lambda_6 - \lambda_9 &= -mg, \\ -b_{5,10}\lambda_5 - b_{6,10}\lambda_6 - b_{8,10}\lambda_8 - b_{9,10}\lambda_9 &= 0, & -b_{4,11}\lambda_4 - b_{7,11}\lambda_7 &= 0, & -b_{5,12}\lambda_5 - b_{6,12}\lambda_6 - b_{8,12}\lambda_8 - b_{9,12}\lambda_9 &= 0, \\ \lambda_7 - \lambda_{10} &= 0, & \lambda_8 - \lambda_{11} &= 0, & \lambda_9 - \lambda_{12} &= -mg, \\ -b_{8,16}\lambda_8 - b_{9,16}\lambda_9 - b_{11,16}\lambda_{11} - b_{12,16}\lambda_{12} &= 0, & -b_{7,17}\lambda_7 - b_{10,17}\lambda_{10} &= 0, & -b_{8,18}\lambda_8 - b_{9,18}\lambda_9 - b_{11,18}\lambda_{11} - b_{12,18}\lambda_{12} &= 0 \end{aligned}"
        => r"\begin{aligned} -\lambda_1 - \lambda_4 &= 0, & -\lambda_2 - \lambda_5 &= 0, & -\lambda_3 - \lambda_6 &= -mg, \\ -b_{2,4}\lambda_2 - b_{3,4}\lambda_3 - b_{5,4}\lambda_5 - b_{6,4}\lambda_6 &= 0, & \fixed{-b_{1,5}\lambda_1 - b_{4,5}\lambda_4} &= 0, & -b_{2,6}\lambda_2 - b_{3,6}\lambda_3 - b_{5,6}\lambda_5 - b_{6,6}\lambda_6 &= 0, \\ \lambda_4 - \lambda_7 &= 0, & \lambda_5 - \lambda_8 &= 0, & \lambda_6 - \lambda_9 &= -mg, \\ -b_{5,10}\lambda_5 - b_{6,10}\lambda_6 - b_{8,10}\lambda_8 - b_{9,10}\lambda_9 &= 0, & -b_{4,11}\lambda_4 - b_{7,11}\lambda_7 &= 0, & -b_{5,12}\lambda_5 - b_{6,12}\lambda_6 - b_{8,12}\lambda_8 - b_{9,12}\lambda_9 &= 0, \\ \lambda_7 - \lambda_{10} &= 0, & \lambda_8 - \lambda_{11} &= 0, & \lambda_9 - \lambda_{12} &= -mg, \\ -b_{8,16}\lambda_8 - b_{9,16}\lambda_9 - b_{11,16}\lambda_{11} - b_{12,16}\lambda_{12} &= 0, & -b_{7,17}\lambda_7 - b_{10,17}\lambda_{10} &= 0, & -b_{8,18}\lambda_8 - b_{9,18}\lambda_9 - b_{11,18}\lambda_{11} - b_{12,18}\lambda_{12} &= 0 \end{aligned}";
    "(xxiv)" "What is left of (xxiii) in the plane. A sign in the row of φ₂ is wrong, and the row of φ₃ is torn into two equations, each false at the equilibrium by the same amount with opposite signs."
        r"\begin{aligned} \lambda_2 + \lambda_5 &= 0, & \lambda_3 + \lambda_6 &= mg, \\ \lambda_2\cos\varphi_1 + \lambda_3\sin\varphi_1 - \lambda_5\cos\varphi_1 - \lambda_6\sin\varphi_1 &= 0, & & \\ \lambda_5 - \lambda_8 &= 0, & \lambda_6 - \lambda_9 &= -mg, \\ \wrong{\lambda_5\cos\varphi_2} - \lambda_6\sin\varphi_2 - \lambda_8\cos\varphi_2 - \lambda_9\sin\varphi_2 &= 0, & & \\ \lambda_8 - \lambda_{11} &= 0, & \lambda_9 - \lambda_{12} &= -mg, \\ \wrong{-\lambda_8\cos\varphi_3 - \lambda_9\sin\varphi_3} &\wrong{= 0,} & & \\ \wrong{-\lambda_{11}\cos\varphi_3 - \lambda_{12}\sin\varphi_3} &\wrong{= 0} & & \end{aligned}"
        => r"\begin{aligned} \lambda_2 + \lambda_5 &= 0, & \lambda_3 + \lambda_6 &= mg, \\ \lambda_2\cos\varphi_1 + \lambda_3\sin\varphi_1 - \lambda_5\cos\varphi_1 - \lambda_6\sin\varphi_1 &= 0, & & \\ \lambda_5 - \lambda_8 &= 0, & \lambda_6 - \lambda_9 &= -mg, \\ \fixed{-}\lambda_5\cos\varphi_2 - \lambda_6\sin\varphi_2 - \lambda_8\cos\varphi_2 - \lambda_9\sin\varphi_2 &= 0, & & \\ \lambda_8 - \lambda_{11} &= 0, & \lambda_9 - \lambda_{12} &= -mg, \\ \fixed{-\lambda_8\cos\varphi_3 - \lambda_9\sin\varphi_3 - \lambda_{11}\cos\varphi_3 - \lambda_{12}\sin\varphi_3} &= 0 & & \end{aligned}";
    "(xxv)" "(iii) in the notation of the second solution."
        r"\cos\varphi_1 + \cos\varphi_2 + \cos\varphi_3 - 2 = 0";
    "(xxvi)" "(iv) in the notation of the second solution."
        r"\sin\varphi_1 + \sin\varphi_2 + \sin\varphi_3 = 0";
}
