//! Section V, the inertial matrices: eqs. (23)-(32).

equations! {
    "(23)" "The matrix that turns rates of the three angles into the angular velocity in the bar's own axes. The second form holds; the first lost the brackets that make three columns."
        r"[\mathbf{Q}_i] = \wrong{[\boldsymbol{\varphi}_i]^T [\boldsymbol{\theta}_i]^T \{\mathbf{u}_\psi\} \{\mathbf{u}_\theta\} \{\mathbf{u}_\varphi\}} = \begin{bmatrix} \cos\theta_i \cos\varphi_i & \sin\varphi_i & 0 \\ -\cos\theta_i \sin\varphi_i & \cos\varphi_i & 0 \\ \sin\theta_i & 0 & 1 \end{bmatrix}, \quad i = \range{1,3}"
        => r"[\mathbf{Q}_i] = \fixed{\left[ [\boldsymbol{\varphi}_i]^T [\boldsymbol{\theta}_i]^T \{\mathbf{u}_\psi\} \;\; [\boldsymbol{\varphi}_i]^T \{\mathbf{u}_\theta\} \;\; \{\mathbf{u}_\varphi\} \right]} = \begin{bmatrix} \cos\theta_i \cos\varphi_i & \sin\varphi_i & 0 \\ -\cos\theta_i \sin\varphi_i & \cos\varphi_i & 0 \\ \sin\theta_i & 0 & 1 \end{bmatrix}, \quad i = \range{1,3}";
    "(24)" "The angular velocity, written out. The minus of its first component contradicts (23)."
        r"\{\boldsymbol{\omega}_i\} = [\mathbf{Q}_i] \begin{bmatrix} \dot\psi_i \\ \dot\theta_i \\ \dot\varphi_i \end{bmatrix} = \begin{bmatrix} \wrong{-\dot\psi_i \cos\theta_i \cos\varphi_i} + \dot\theta_i \sin\varphi_i \\ -\dot\psi_i \cos\theta_i \sin\varphi_i + \dot\theta_i \cos\varphi_i \\ \dot\psi_i \sin\theta_i + \dot\varphi_i \end{bmatrix} = \begin{bmatrix} \omega_{x_i} \\ \omega_{y_i} \\ \omega_{z_i} \end{bmatrix}, \quad i = \range{1,3}"
        => r"\{\boldsymbol{\omega}_i\} = [\mathbf{Q}_i] \begin{bmatrix} \dot\psi_i \\ \dot\theta_i \\ \dot\varphi_i \end{bmatrix} = \begin{bmatrix} \fixed{\dot\psi_i \cos\theta_i \cos\varphi_i} + \dot\theta_i \sin\varphi_i \\ -\dot\psi_i \cos\theta_i \sin\varphi_i + \dot\theta_i \cos\varphi_i \\ \dot\psi_i \sin\theta_i + \dot\varphi_i \end{bmatrix} = \begin{bmatrix} \omega_{x_i} \\ \omega_{y_i} \\ \omega_{z_i} \end{bmatrix}, \quad i = \range{1,3}";
    "(25)" "The cross product with the angular velocity, as a skew matrix."
        r"[\boldsymbol{\omega}_i] = \begin{bmatrix} 0 & -\omega_{z_i} & \omega_{y_i} \\ \omega_{z_i} & 0 & -\omega_{x_i} \\ -\omega_{y_i} & \omega_{x_i} & 0 \end{bmatrix}, \quad i = \range{1,3}";
    "(26)" "The moments of inertia about the principal axes through the centre of weight."
        r"[\mathbf{J}_{C_i}] = \begin{bmatrix} J_{x_i} & 0 & 0 \\ 0 & J_{y_i} & 0 \\ 0 & 0 & J_{z_i} \end{bmatrix}, \quad i = \range{1,3}";
    "(27)" "The bar's axes start at its centre of weight."
        r"x_{C_i} = y_{C_i} = z_{C_i} = 0, \quad i = \range{1,3}";
    "(28)" "The static moment of a bar about its own centre is zero (m stands for the bar's own mass)."
        r"[\mathbf{S}_i] = \begin{bmatrix} 0 & -m z_{C_i} & m y_{C_i} \\ m z_{C_i} & 0 & -m x_{C_i} \\ -m y_{C_i} & m x_{C_i} & 0 \end{bmatrix} = \begin{bmatrix} 0 & 0 & 0 \\ 0 & 0 & 0 \\ 0 & 0 & 0 \end{bmatrix}, \quad i = \range{1,3}";
    "(29)" "Turning a bar about its centre carries no momentum."
        r"[\mathbf{A}_i] [\mathbf{S}_i]^T [\mathbf{Q}_i] = \begin{bmatrix} 0 & 0 & 0 \\ 0 & 0 & 0 \\ 0 & 0 & 0 \end{bmatrix}, \quad i = \range{1,3}";
    "(30)" "Moving the centre has no moment of momentum about it: the transpose of (29)."
        r"[\mathbf{Q}_i]^T [\mathbf{S}_i] [\mathbf{A}_i]^T = \begin{bmatrix} 0 & 0 & 0 \\ 0 & 0 & 0 \\ 0 & 0 & 0 \end{bmatrix}, \quad i = \range{1,3}";
    "(31)" "The inertia of a bar in the rates of its angles. It must be symmetric, which the print is not."
        r"[\mathbf{Q}_i]^T [\mathbf{J}_{C_i}] [\mathbf{Q}_i] = \begin{bmatrix} J_{x_i} c^2\varphi_i\, c^2\theta_i + J_{y_i} s^2\varphi_i\, c^2\theta_i + J_{z_i} s^2\theta_i & J_{x_i} c\varphi_i\, c\theta_i\, s\varphi_i - J_{y_i} c\varphi_i\, c\theta_i\, s\varphi_i & J_{z_i} s\theta_i \\ \wrong{J_{x_i} c\varphi_i\, s\theta_i\, s\varphi_i - J_{x_i} c\varphi_i\, s\theta_i\, s\varphi_i} & \begin{matrix} J_{x_i} s^2\varphi_i + J_{y_i} c^2\varphi_i \\ \wrong{J_{z_i} s\varphi_i} \end{matrix} & 0 \\ \wrong{J_{z_i} s\varphi_i} & 0 & J_{z_i} \end{bmatrix}, \quad i = \range{1,3}"
        => r"[\mathbf{Q}_i]^T [\mathbf{J}_{C_i}] [\mathbf{Q}_i] = \begin{bmatrix} J_{x_i} c^2\varphi_i\, c^2\theta_i + J_{y_i} s^2\varphi_i\, c^2\theta_i + J_{z_i} s^2\theta_i & J_{x_i} c\varphi_i\, c\theta_i\, s\varphi_i - J_{y_i} c\varphi_i\, c\theta_i\, s\varphi_i & J_{z_i} s\theta_i \\ \fixed{J_{x_i} c\varphi_i\, c\theta_i\, s\varphi_i - J_{y_i} c\varphi_i\, c\theta_i\, s\varphi_i} & \fixed{J_{x_i} s^2\varphi_i + J_{y_i} c^2\varphi_i} & 0 \\ \fixed{J_{z_i} s\theta_i} & 0 & J_{z_i} \end{bmatrix}, \quad i = \range{1,3}";
    "(32)" "The matrix of inertia of a bar: mass for its centre, (31) for its angles. Two brackets side by side, as the copy of the text at hand has them, are a product of too many rows; one block diagonal matrix of 6 rows is meant, with (31) corrected."
        r"[\mathbf{M}_i] = \wrong{\begin{bmatrix} m_i & 0 & 0 \\ 0 & m_i & 0 \\ 0 & 0 & m_i \end{bmatrix} \begin{bmatrix} \mathbf{0} \\ \mathbf{0} \\ {}[\mathbf{Q}_i]^T [\mathbf{J}_{C_i}] [\mathbf{Q}_i] \end{bmatrix}}, \quad i = \range{1,3}"
        => r"[\mathbf{M}_i] = \fixed{\begin{bmatrix} m_i & 0 & 0 & \\ 0 & m_i & 0 & [\mathbf{0}_{3,3}] \\ 0 & 0 & m_i & \\ & [\mathbf{0}_{3,3}] & & [\mathbf{Q}_i]^T [\mathbf{J}_{C_i}] [\mathbf{Q}_i] \end{bmatrix}}, \quad i = \range{1,3}";
}
