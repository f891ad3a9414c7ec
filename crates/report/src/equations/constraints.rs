//! Sections III and IV, the constraint functions and their matrix: eqs. (6)-(22).

equations! {
    "(6)" "From the centre of bar 1, back along the bar by r₁, lies the fixed end O."
        r"\begin{bmatrix} X_{O} \\ Y_{O} \\ Z_{O} \end{bmatrix} = \begin{bmatrix} X_{C_1} \\ Y_{C_1} \\ Z_{C_1} \end{bmatrix} + [A_1] \begin{bmatrix} -r_1 \\ 0 \\ 0 \end{bmatrix}";
    "(7)" "Bar 1 is held at O, horizontally along X."
        r"f_{1} = X_{C_1} - r_1 \cos\theta_1\cos\varphi_1 = 0";
    "(8)" "Bar 1 is held at O, horizontally along Y."
        r"f_{2} = Y_{C_1} - r_1 (\sin\psi_1\sin\theta_1\cos\varphi_1 + \cos\psi_1\sin\varphi_1) = 0";
    "(9)" "Bar 1 is held at O, in height."
        r"f_{3} = Z_{C_1} - r_1 (-\cos\psi_1\sin\theta_1\cos\varphi_1 + \sin\psi_1\sin\varphi_1) = 0";
    "(10)" "Joint A₁ as the far end of bar 1."
        r"\begin{bmatrix} X_{A_1} \\ Y_{A_1} \\ Z_{A_1} \end{bmatrix} = \begin{bmatrix} X_{C_1} \\ Y_{C_1} \\ Z_{C_1} \end{bmatrix} + [A_1] \begin{bmatrix} l_1 - r_1 \\ 0 \\ 0 \end{bmatrix}";
    "(11)" "The same joint as the near end of bar 2."
        r"\begin{bmatrix} X_{A_1} \\ Y_{A_1} \\ Z_{A_1} \end{bmatrix} = \begin{bmatrix} X_{C_2} \\ Y_{C_2} \\ Z_{C_2} \end{bmatrix} + [A_2] \begin{bmatrix} -r_2 \\ 0 \\ 0 \end{bmatrix}";
    "(12)" "Bars 1 and 2 meet at A₁, horizontally along X."
        r"f_{4} = X_{C_1} + (l_1 - r_1) \cos\theta_1\cos\varphi_1 - X_{C_2} + r_2 \cos\theta_2\cos\varphi_2 = 0";
    "(13)" "Bars 1 and 2 meet at A₁, horizontally along Y."
        r"f_{5} = Y_{C_1} + (l_1 - r_1) (\sin\psi_1\sin\theta_1\cos\varphi_1 + \cos\psi_1\sin\varphi_1) - Y_{C_2} + r_2 (\sin\psi_2\sin\theta_2\cos\varphi_2 + \cos\psi_2\sin\varphi_2) = 0";
    "(14)" "Bars 1 and 2 meet at A₁, in height."
        r"f_{6} = Z_{C_1} + (l_1 - r_1) (-\cos\psi_1\sin\theta_1\cos\varphi_1 + \sin\psi_1\sin\varphi_1) - Z_{C_2} + r_2 (-\cos\psi_2\sin\theta_2\cos\varphi_2 + \sin\psi_2\sin\varphi_2) = 0";
    "(15)" "Bars 2 and 3 meet at A₂, horizontally along X."
        r"f_{7} = X_{C_2} + (l_2 - r_2) \cos\theta_2\cos\varphi_2 - X_{C_3} + r_3 \cos\theta_3\cos\varphi_3 = 0";
    "(16)" "Bars 2 and 3 meet at A₂, horizontally along Y."
        r"f_{8} = Y_{C_2} + (l_2 - r_2) (\sin\psi_2\sin\theta_2\cos\varphi_2 + \cos\psi_2\sin\varphi_2) - Y_{C_3} + r_3 (\sin\psi_3\sin\theta_3\cos\varphi_3 + \cos\psi_3\sin\varphi_3) = 0";
    "(17)" "Bars 2 and 3 meet at A₂, in height."
        r"f_{9} = Z_{C_2} + (l_2 - r_2) (-\cos\psi_2\sin\theta_2\cos\varphi_2 + \sin\psi_2\sin\varphi_2) - Z_{C_3} + r_3 (-\cos\psi_3\sin\theta_3\cos\varphi_3 + \sin\psi_3\sin\varphi_3) = 0";
    "(18)" "The last bar is held at A₃, horizontally along X. Printed with the index of bar 2, which does not reach A₃."
        r"f_{10} = \wrong{X_{C_2} + (l_2 - r_2) \cos\theta_2\cos\varphi_2} - X_3 = 0"
        => r"f_{10} = \fixed{X_{C_3} + (l_3 - r_3) \cos\theta_3\cos\varphi_3} - X_3 = 0";
    "(19)" "The last bar is held at A₃, horizontally along Y. Printed with the index of bar 2, which does not reach A₃."
        r"f_{11} = \wrong{Y_{C_2} + (l_2 - r_2) (\sin\psi_2\sin\theta_2\cos\varphi_2 + \cos\psi_2\sin\varphi_2)} - Y_3 = 0"
        => r"f_{11} = \fixed{Y_{C_3} + (l_3 - r_3) (\sin\psi_3\sin\theta_3\cos\varphi_3 + \cos\psi_3\sin\varphi_3)} - Y_3 = 0";
    "(20)" "The last bar is held at A₃, in height. Printed with the index of bar 2, which does not reach A₃."
        r"f_{12} = \wrong{Z_{C_2} + (l_2 - r_2) (-\cos\psi_2\sin\theta_2\cos\varphi_2 + \sin\psi_2\sin\varphi_2)} - Z_3 = 0"
        => r"f_{12} = \fixed{Z_{C_3} + (l_3 - r_3) (-\cos\psi_3\sin\theta_3\cos\varphi_3 + \sin\psi_3\sin\varphi_3)} - Z_3 = 0";
    "(21)" "The 18 coordinates: centre and three angles of each bar."
        r"\{\mathbf{q}\} = \left[ X_{C_1} \dots \varphi_1 \dots X_{C_3} \dots \varphi_3 \right]^T";
    "(22)" "The matrix of constraints: how each of the twelve closures changes with each coordinate."
        r"b_{i,j} = \frac{\partial f_i}{\partial q_j}, \quad i = \range{1,12}, \quad j = \range{1,18}";
}
